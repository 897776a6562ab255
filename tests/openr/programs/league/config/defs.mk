OPENRSDK_ROOT ?= /usr/local/OPEN_R_SDK
CONFIGURATION ?= Release
TOOLS = $(OPENRSDK_ROOT)/bin/mipsel-linux-
CXX = $(TOOLS)g++
CC = $(TOOLS)gcc
AR = $(TOOLS)ar
RANLIB = $(TOOLS)ranlib
STRIP = $(TOOLS)strip
MKBIN = $(OPENRSDK_ROOT)/OPEN_R/bin/mkbin
STUBGEN = $(OPENRSDK_ROOT)/OPEN_R/bin/stubgen2
INSTALLDIR ?= $(TOP)/MS_ERS7
INCS = -I. -I$(TOP)/common -I$(OPENRSDK_ROOT)/OPEN_R/include/R4000 -I$(OPENRSDK_ROOT)/OPEN_R/include
ifeq ($(CONFIGURATION),Debug)
CXXFLAGS = -g -O0 -DOPENR_DEBUG -DDEBUG=1
else
CXXFLAGS = -O3 -DNDEBUG -ffast-math -fomit-frame-pointer -finline-limit=1000 -fno-exceptions -fno-rtti -msoft-float -mlong32 -mips3 -mno-split-addresses -pipe -ansi -pedantic -Wall -W -Wno-unused -Woverloaded-virtual -fno-for-scope -fmessage-length=0
endif
CXXFLAGS += $(INCS) -MD -MP
OBJDIR = obj/$(CONFIGURATION)
